// The types of what Python, the page and these scripts exchange, checked by tsc; not in the bundle.

type Put = (x: number, y: number, z: number) => void;
type Points = (i: number, put: Put) => void;
type Axis = "x" | "y" | "z";
type XYZ = [x: number, y: number, z: number];
type Later = { (): void; cancel(): void };

// The top at one moment, in space-fixed axes; app/widgets/top3d.py explains each.
type Pose = Record<"contact" | "com" | "force" | "omega" | "momentum", import("three").Vector3> & {
  quaternion: import("three").Quaternion;
  theta: number;
  regime: number;
};

// A text at a point in space; shift: its offset from there, in px.
type Label = { element: HTMLElement; at: import("three").Vector3; shift: [number, number]; visible: boolean; margin: number };

// What a text points at, shown alone: a vector along the turning axes 1', y, z, from G or from the contact.
type Pointed = { label: string; start: "com" | "contact"; vector: [number, number, number] };

// A component's model has its parameters, which the Python class of the same name explains.
interface Model {
  texts: Record<string, any>;
  on(name: string, run: () => void): void;
}

// Panel calls render with these. The view stays the same object when it is rendered again.
interface Rendering<M extends Model> {
  model: M;
  el: HTMLElement;
  view: { tippe?: { dispose(): void; life: AbortSignal; hold?(held: boolean): void; look?(): void } };
}

type Bytes = ArrayBuffer | Uint8Array<ArrayBuffer> | null;

// What a flick on the top does, and how its size is said; in units of M, R and g, and rev/s.
interface Hand {
  hold(held: boolean): void;
  push(point: number[], impulse: number[]): void;
  spin(turns: number): void;
  sizeText(size: number): string;
  turnsText(turns: number): string;
}

// A push of a run: its time (s), the point from O in R along 1', 2', 3, the impulse in M (gR)^1/2 along x, y, z, and its size.
type Pushed = { t: number; point: number[]; impulse: number[]; wording: string };

// An earlier run, shown beside the present one.
type Before = { frames: Bytes; profile: Bytes; a: number; seconds: number };

interface TopModel extends Model, Record<Part3D, boolean> {
  before?: Before | null;
  pulled?: { to(theta: number, azimuth: number): void; letGo(): void }; // what a hand on the axis asks for, rad
  flick?: Hand;
  pushes?: Pushed[];
  frames: Bytes;
  profile: Bytes;
  mu_s: number;
  seconds: number;
  time: number;
  label: string;
  clock: string;
  a: number | null;
  bare?: boolean; // without a bar of its own
  azimuth?: number; // rad: as of Frames
  playing: boolean;
  speed: number;
  now?: number; // ms: the time of a film in which it is drawn, picture by picture
  until?: number; // the motion is played once, to this time; else it repeats
  camera: number[];
  measured?: Bytes;
  measured_label?: string;
}
type Part3D = "show_track" | "show_trace" | "show_com_path" | "show_force" | "show_cone" | "show_omega" | "show_momentum" | "follow";

interface SurfaceModel extends Model {
  K_J: Bytes;
  theta: Bytes;
  heights: Bytes;
  energy: Bytes;
  verge: Bytes;
  steady: Bytes;
  P: Bytes;
  selected: Bytes;
  selected_curve: Bytes;
  theta_max: number;
  limit: "lift-off" | "slip";
  hand: [grip: "end" | "line" | "point" | "tieline", theta: number, K_J: number] | [];
}

interface SectionModel extends Model {
  state: string;
  hand: [name: string, x: number, z: number] | [];
  tapped: [count: number, name: string, x: number, z: number] | [];
}

interface PlaneModel extends Model {
  state: string;
  motion: Bytes;
  limits: Bytes;
  field: Bytes;
  path: Bytes;
  clock: string;
  hand: [grip: string, theta: number, K_J: number] | [];
  pressed: [count: number, road: string] | [];
}

// The words of a number control: its name, the name of its field, its unit; in HTML, on hover and as it is read aloud.
type Wording = { name: string; typed: string; unit: string; html?: string; hint?: string; speaks?: string; symbol?: string };
interface ChoiceModel extends Model {
  label: string;
  options: Record<string, string | number>;
  value: string | number;
}

interface ButtonModel extends Model {
  label: string;
  kind: "primary" | "outline" | "link";
  disabled: boolean;
  clicks: number;
}

interface FieldModel extends Model {
  label: string;
  value: string;
  shows: string;
  unit: string;
  placeholder: string;
  size: number;
  wrong: [why: string, nearest: string, back: string] | [];
}

type MenuModel = ChoiceModel;

interface ChecksModel extends Model {
  label: string;
  options: Record<string, string | number>;
  value: (string | number)[];
}

interface StretchModel extends Model {
  label: string;
  start: number;
  end: number;
  step: number;
  digits: number;
  unit: string;
  value: number[];
  pulled: [count: number, from: number, to: number];
}

interface TextFileModel extends Model {
  label: string;
  accept: string;
  most: number;
  sent: [text: string, count: number, size: number];
}

interface FormModel extends Model {
  parts: string;
  state: string;
  sent: [count: number, at: number, name: string, value: any];
  file: [at: number, count: number, base64: string, name: string] | [];
  get_child(name: string): HTMLElement[];
}

interface FoldModel extends Model {
  label: string;
  get_child(name: string): HTMLElement;
}

interface NumberControlsModel extends Model {
  parts: string;
  state: string;
  request: [count: number, name: string, wish: number | string, typed: boolean] | [];
}

type KnownTop = { name: string; label: string; a: number; ratio: number; outline: [radius: number, height: number][] };
interface TopsMapModel extends Model {
  state: { tops: KnownTop[]; here: { a: number; ratio: number; outline: [radius: number, height: number][] | null }; chosen: string };
  picked: [count: number, name: string] | [];
  moved: [count: number, a: number, ratio: number] | [];
}

interface GuideModel extends Model {
  tour: boolean;
  wording: string;
}

interface HeadModel extends Model {
  state: Record<string, any>;
  request: [count: number, name: string, value: any] | [];
}

interface LookModel extends Model {
  id: string;
  dark: boolean | null;
  large: boolean;
}

interface DownloadModel extends Model {
  label: string;
  filename: string;
  clicks: number;
  file: [count: number, base64: string, name: string];
  making: boolean;
  disabled: boolean;
}

interface FilmStageModel extends Model {
  clock: string;
  label: string;
  none: string;
  frames: Bytes;
  profile: Bytes;
  tilts: Bytes;
  measured: Bytes;
  measured_label: string;
  a: number | null;
  start: number;
  anew: boolean;
}

interface MeasuredFileModel extends Model {
  most: number;
  rows: number;
  head: number;
  packed: number;
  table: [text: string, each: number, count: number, name: string, size: number];
  piece: [text: string, at: number, pieces: number, count: number, name: string, size: number];
}

interface PhotoModel extends Model {
  caption: string[];
  wide: number;
  none: string;
}

interface EmbedModel extends Model {
  code: string;
  frames: string;
}

interface FilmModel extends Model {
  encoders: string;
  anew: number;
}

interface ShareHeadModel extends Model {
  texts: Record<string, any>;
  link: string;
  picture: string;
  wording: string[];
  opened: number;
  closed: number;
}

interface PaperModel extends Model {
  label: string;
  page: string;
}

interface CopyModel extends Model {
  text: string;
  label: string;
  rows: number;
  button: [before: string, after: string];
}

interface AddressModel extends Model {
  search: string;
  where: string;
  visited: [count: number, where: string] | [];
  page: string;
  held: boolean;
  gesture: number;
  undone: number;
  redone: number;
}

interface FailureModel extends Model {
  words: string;
  close: string;
  waits: string;
}

interface ConnectionModel extends Model {
  words: string;
  slow: string;
}

interface EventListModel extends Model {
  clock: string;
  rows: [t: number, when: string, word: string, more: string][];
}

interface PaintedModel extends Model {
  sent: number;
  painted: number;
}

interface PhoneModel extends Model {
  mark: string;
}

interface LinesModel extends Model {
  clock: string;
  lines: any[];
  symbols: Record<string, any>;
  words: Record<string, string>;
  rough: any;
  smooth: any;
  periods: number[];
  widths: number[];
}

// A column of a figure's data source; a position between two of its rows.
type Column = ArrayLike<number> & { reduce(take: (best: number, value: number, row: number) => number, first: number): number };
type Spot = [row: number, share: number];
type PixelScale = { compute(value: number): number; invert(px: number): number };
type RowPlace = { spot: Spot; row: number }; // between two rows, and the nearer one
type Limits = Record<"K_J" | "lift_in" | "slip_in" | "slip_out" | "lift_out" | "verge" | "lift_verge" | "steady" | "slip_E", Float64Array> & { slip_by: string[]; lift_by: string[] };
type Path = Record<"theta" | "low" | "high" | "K_J" | "K_R", Float32Array>;
type Shown = Tieline & { K_R: number; steady: number };
type Tieline = { K_J: number; inner: number; outer: number };

// app/tabs/lab/lab.py says what each contains.
type LabModel = Model & Record<"state" | "told", string> & Record<`${"frames" | "curves" | "keeps"}_${"ordinary" | "rough" | "ice"}` | "profile", Bytes> & Record<Part3D, boolean> & {
  a: number;
  seconds: number;
  level: string;
  time: number;
  playing: boolean;
  speed: number;
  camera: number[];
  request: [count: number, name: string, value: any] | [];
};

// app/tabs/learn/lesson.py says what each contains.
type LessonRun = Record<"frames" | "profile" | "curves" | "arms", Bytes> & { a: number; seconds: number };
type LessonModel = Model & Record<"state", any> & {
  worksheet: string;
  steps: any[];
  runs: Record<string, LessonRun>;
  others: Record<string, LessonRun>;
  request: [count: number, name: string, value: string | number] | [];
};

interface StepsModel extends Model {
  curves: any[];
  points: [word: string, seconds: number, degrees: number][];
}

type DrawingModel = Model & Record<`data${number}`, Record<string, any>> & {
  described: string;
  heads: string[];
  looks: Record<string, Record<string, any>>;
  heard: string[];
  sent: [count: number, id: string, data: Record<string, any>];
};

// Bokeh's models, as far as they are used here.
interface BokehModel {
  setv(values: Record<string, any>): void;
  properties: Record<string, { change: { connect(run: () => void): void } }>;
  change: { emit(): void };
}
interface Figure extends BokehModel {
  name: string;
  x_range: { start: number; end: number };
  y_range: { start: number; end: number };
}
interface Source<Names extends string = string> extends BokehModel {
  data: Record<Names, any>;
  tags: any[];
}
// What a person did on a figure: where, in data coordinates and in px.
type Happened = { event_name: string; x: number; y: number; sx: number; sy: number };

declare const Bokeh: { documents: any[]; index: any; embed: any; require(path: string): any; Models: any };

// What Bokeh passes to app/call.js and app/ticks.js, which it runs.
declare const run: string, given: any, cb_obj: any, basic: any, ticks: number[], index: number, point: string;

interface Window {
  // A report of what is drawn, only for tests: nothing in the program reads it.
  __tippe: Record<string, any>;
  tippeCallbacks: Record<string, (given: any, what: any) => unknown>; // from figures/callbacks.js
  importShim: any; // Panel's import()
  katex?: { render(tex: string, el: HTMLElement, options: object): void };
  // Our own events; their contents are described where they are sent.
  addEventListener(type: `tippe:${string}`, run: (event: CustomEvent) => void, options?: AddEventListenerOptions): void;
  removeEventListener(type: `tippe:${string}`, run: (event: CustomEvent) => void): void;
}
