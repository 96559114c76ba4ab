// The code to copy, and how it would look; or why no other page may show this one.
import { part } from "../parts.js";
import { copyButton } from "./copy.js";
import { frame, whenSeen } from "../controls/frame.js";
import { offer, toCopy } from "../controls/style.js";
import { follow } from "../life.js";
import { fill, penOf } from "../data.js";
import { photosOf } from "../motion/clock.js";

const SMALL = 240; // px: the width of a preview
const STYLE = `${offer}${toCopy}.all > .preview { flex: none; border: 1px solid var(--line-2); border-radius: 6px; }`;

/** @param {Rendering<EmbedModel>} rendering */
export function renderEmbed(rendering) {
  const { model } = rendering, { texts } = model, others = model.frames.split(/\s+/).filter((each) => each && !["'self'", "'none'"].includes(each));
  const area = part("textarea", { readonly: true, rows: 4, spellcheck: "false", "aria-label": texts.title, hidden: !others.length, onfocus: () => area.select() });
  const copy = copyButton(area, "outline word", [texts.copy, texts.copied]);
  copy.hidden = !others.length;
  const preview = part("canvas", { class: "preview", role: "img", "aria-label": texts.preview, hidden: true });
  const who = !others.length ? texts.refused : others.includes("*") ? "" : fill(texts.only, { sites: others.join(", ") });
  const all = part("div", { class: "all" }, part("span", { class: "says" }, part("b", {}, texts.title), part("span", { class: "small" }, texts.says)), copy, area, preview,
    part("p", { class: "small", hidden: !who }, who));
  const life = frame(rendering, STYLE, all);
  const look = () => {
    area.value = model.code;
    const pictures = others.length && all.clientWidth ? photosOf(SMALL).map(({ picture }) => picture) : [];
    preview.hidden = !pictures.length;
    if (!pictures.length) return;
    Object.assign(preview, { width: SMALL, height: Math.max(...pictures.map(({ height }) => height)) });
    pictures.forEach((picture, i) => penOf(preview).drawImage(picture, (i * SMALL) / pictures.length, 0));
  };
  whenSeen(all, look, life);
  follow(model, ["code"], () => (area.value = model.code));
}
