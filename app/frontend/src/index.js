import { renderChoice } from "./controls/choice.js";
import { renderNumberControls } from "./controls/group.js";
import { offerCallbacks } from "./figures/callbacks.js";
import { first } from "./first.js";
import { renderFirst } from "./first.js";
import { letter } from "./letter.js";
import { renderLesson } from "./learn/lesson.js";
import { renderSteps } from "./learn/steps.js";
import { timeOf, topsOf } from "./motion/clock.js";
import { renderPlane } from "./plane/plane.js";
import { renderSurface3D } from "./three/surface3d.js";
import { renderTop3D } from "./three/top3d.js";
import { renderAddress } from "./widgets/address.js";
import { renderCopy } from "./widgets/copy.js";
import { renderDownload } from "./widgets/download.js";
import { renderMeasuredFile } from "./widgets/measured_file.js";
import { renderFilmStage } from "./widgets/film_stage.js";
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
import { renderSymbols } from "./widgets/symbols.js";
import { renderTopsMap } from "./widgets/tops_map.js";
import { renderSaid } from "./widgets/said.js";
import { renderPhoto } from "./widgets/photo.js";

offerCallbacks();
window.__tippe = { time: timeOf, tops: topsOf }; // for tests only: there before any component is

// Panel finds a component by the name of its Python class.
export default {
  Address: { render: renderAddress },
  Choice: { render: renderChoice },
  Connection: { render: renderConnection },
  Copy: { render: renderCopy },
  Download: { render: renderDownload },
  Failure: { render: renderFailure },
  MeasuredFile: { render: renderMeasuredFile },
  FilmStage: { render: renderFilmStage },
  Guide: { render: renderGuide },
  Head: { render: renderHead },
  LessonView: { render: renderLesson },
  LabView: { render: renderFirst },
  Lines: { render: renderLines },
  Look: { render: renderLook },
  Moments: { render: renderMoments },
  NumberControls: { render: renderNumberControls },
  Painted: { render: renderPainted },
  Paper: { render: renderPaper },
  Phone: { render: renderPhone },
  PlaneView: { render: renderPlane },
  Photo: { render: renderPhoto },
  Said: { render: renderSaid },
  Steps: { render: renderSteps },
  ShareHead: { render: renderShareHead },
  Surface3D: { render: renderSurface3D },
  Top3D: { render: renderTop3D },
  Symbols: { render: renderSymbols },
  TopsMap: { render: renderTopsMap },
  first,
  letter,
};
