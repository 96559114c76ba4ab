import { renderChoice } from "./controls/choice.js";
import { renderFold } from "./controls/file.js";
import { renderTextFile } from "./controls/file.js";
import { renderButton } from "./controls/button.js";
import { renderChecks } from "./controls/menu.js";
import { renderField } from "./controls/field.js";
import { renderMenu } from "./controls/menu.js";
import { renderNumberControls } from "./controls/group.js";
import { renderStretch } from "./controls/stretch.js";
import { offerCallbacks } from "./figures/callbacks.js";
import { first } from "./first.js";
import { renderFirst } from "./first.js";
import { letter } from "./letter.js";
import { renderLesson } from "./learn/lesson.js";
import { renderSteps } from "./learn/steps.js";
import { timeOf, topsOf } from "./motion/clock.js";
import { renderPlane } from "./plane/plane.js";
import { renderSurface3D } from "./three/surface3d.js";
import { site } from "./site.js";
import { wear } from "./tokens.js";
import { renderTop3D } from "./three/top3d.js";
import { renderAddress } from "./widgets/address.js";
import { renderCopy } from "./widgets/copy.js";
import { renderDownload } from "./widgets/download.js";
import { renderMeasuredFile } from "./widgets/measured_file.js";
import { renderEmbed } from "./widgets/embed.js";
import { renderFilm } from "./widgets/film.js";
import { renderFilmStage } from "./widgets/film_stage.js";
import { renderFrame } from "./widgets/frame.js";
import { renderGuide } from "./widgets/guide.js";
import { renderHead } from "./widgets/head.js";
import { renderLines } from "./widgets/lines.js";
import { renderLook } from "./widgets/look.js";
import { renderConnection } from "./widgets/notices.js";
import { renderFailure } from "./widgets/notices.js";
import { renderMoments } from "./widgets/moments.js";
import { renderPainted } from "./widgets/painted.js";
import { renderPaper } from "./widgets/paper.js";
import { renderPhone } from "./widgets/phone.js";
import { renderShareHead } from "./widgets/share_head.js";
import { renderSection } from "./widgets/section.js";
import { renderSymbols } from "./widgets/symbols.js";
import { renderTopsMap } from "./widgets/tops_map.js";
import { renderSaid } from "./widgets/said.js";
import { renderPhoto } from "./widgets/photo.js";

offerCallbacks();
wear(window.matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light"); // until look.js knows what a person chose
window.__tippe = { time: timeOf, tops: topsOf, wear }; // for tests only: there before any component is

// Panel finds a component by the name of its Python class.
export default {
  Address: { render: renderAddress },
  Button: { render: renderButton },
  Checks: { render: renderChecks },
  Choice: { render: renderChoice },
  Connection: { render: renderConnection },
  Copy: { render: renderCopy },
  Download: { render: renderDownload },
  Embed: { render: renderEmbed },
  Failure: { render: renderFailure },
  MeasuredFile: { render: renderMeasuredFile },
  Field: { render: renderField },
  Film: { render: renderFilm },
  FilmStage: { render: renderFilmStage },
  Fold: { render: renderFold },
  Frame: { render: renderFrame },
  Guide: { render: renderGuide },
  Head: { render: renderHead },
  LessonView: { render: renderLesson },
  LabView: { render: renderFirst },
  Lines: { render: renderLines },
  Look: { render: renderLook },
  Menu: { render: renderMenu },
  Moments: { render: renderMoments },
  NumberControls: { render: renderNumberControls },
  Painted: { render: renderPainted },
  Paper: { render: renderPaper },
  Phone: { render: renderPhone },
  PlaneView: { render: renderPlane },
  Photo: { render: renderPhoto },
  Said: { render: renderSaid },
  SectionView: { render: renderSection },
  Steps: { render: renderSteps },
  ShareHead: { render: renderShareHead },
  Stretch: { render: renderStretch },
  Surface3D: { render: renderSurface3D },
  TextFile: { render: renderTextFile },
  Top3D: { render: renderTop3D },
  Symbols: { render: renderSymbols },
  TopsMap: { render: renderTopsMap },
  first,
  letter,
  site,
};
