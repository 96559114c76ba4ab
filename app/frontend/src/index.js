import { renderChoice as Choice } from "./controls/choice.js";
import { renderFold as Fold, renderTextFile as TextFile } from "./controls/file.js";
import { renderButton as Button } from "./controls/button.js";
import { renderChecks as Checks, renderMenu as Menu } from "./controls/menu.js";
import { renderField as Field } from "./controls/field.js";
import { renderNumberControls as NumberControls } from "./controls/group.js";
import { renderStretch as Stretch } from "./controls/stretch.js";
import { offerCallbacks } from "./figures/callbacks.js";
import { renderDrawing as Drawing } from "./figures/drawing.js";
import { first, renderFirst as LabView } from "./first.js";
import { letter } from "./letter.js";
import { renderLesson as LessonView } from "./learn/lesson.js";
import { renderSteps as Steps } from "./learn/steps.js";
import { timeOf, topsOf } from "./motion/clock.js";
import { renderPlane as PlaneView } from "./plane/plane.js";
import { renderSurface3D as Surface3D } from "./three/surface3d.js";
import { site } from "./site.js";
import { wear } from "./tokens.js";
import { renderTop3D as Top3D } from "./three/top3d.js";
import { renderAddress as Address } from "./widgets/address.js";
import { renderCopy as Copy } from "./widgets/copy.js";
import { renderDownload as Download } from "./widgets/download.js";
import { renderMeasuredFile as MeasuredFile } from "./widgets/measured_file.js";
import { renderEmbed as Embed } from "./widgets/embed.js";
import { renderForm as Form } from "./widgets/form.js";
import { renderFilm as Film } from "./widgets/film.js";
import { renderFilmStage as FilmStage } from "./widgets/film_stage.js";
import { renderFrame as Frame } from "./widgets/frame.js";
import { renderGuide as Guide } from "./widgets/guide.js";
import { renderHead as Head } from "./widgets/head.js";
import { renderLines as Lines } from "./widgets/lines.js";
import { renderLook as Look } from "./widgets/look.js";
import { renderConnection as Connection, renderFailure as Failure } from "./widgets/notices.js";
import { renderEventList as EventList } from "./widgets/event_list.js";
import { renderPainted as Painted } from "./widgets/painted.js";
import { renderPaper as Paper } from "./widgets/paper.js";
import { renderPhone as Phone } from "./widgets/phone.js";
import { renderShareHead as ShareHead } from "./widgets/share_head.js";
import { renderSection as SectionView } from "./widgets/section.js";
import { renderSymbols as Symbols } from "./widgets/symbols.js";
import { renderTopsMap as TopsMap } from "./widgets/tops_map.js";
import { renderPhoto as Photo } from "./widgets/photo.js";

offerCallbacks();
wear(window.matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light"); // until look.js knows what a person chose
window.__tippe = { time: timeOf, tops: topsOf, wear }; // for tests only: there before any component is

// Panel finds a component by the name of its Python class.
const components = {
  Address, Button, Checks, Choice, Connection, Copy, Download, Drawing, Embed, Failure, Field, Film, FilmStage, Fold, Form, Frame, Guide, Head,
  LabView, LessonView, Lines, Look, MeasuredFile, Menu, EventList, NumberControls, Painted, Paper, Phone, Photo, PlaneView,
  SectionView, ShareHead, Steps, Stretch, Surface3D, Symbols, TextFile, Top3D, TopsMap,
};
export default { ...Object.fromEntries(Object.entries(components).map(([name, render]) => [name, { render }])), first, letter, site };
