/** What the editor's view is composed of. A part or tool names what it needs of it, and gets no more. */
export interface Editor {
  root: HTMLElement;
  model: import("../host/types.js").Model;
  /** The edit, its history and what was kept. */
  state: import("../edit/state.js").EditState;
  channel: import("../host/channel.js").Channel;
  kernel: import("./view/kernel.js").Kernel;
  /** What is shown: scene, camera, and the edit or a film's moment. */
  picture: import("./view/picture.js").Picture;
  /** Where it is shown: canvas, overlay, zoom. */
  stage: import("./view/stage.js").Stage;
  /** How it is drawn: the frame and when it is due. */
  drawing: import("./view/drawing.js").Drawing;
  original: import("./view/original.js").Original;
  split: import("./view/split.js").Split;
  fullScreen: import("./view/full_screen.js").FullScreen;
  /** All parts, to be told of what happens. */
  parts: import("./part.js").Parts;
  /** The chosen tool, its brush and the pointer that drags. */
  hand: import("./tools/hand.js").Hand;
  strokes: import("./tools/strokes.js").StrokesLayer;
  inspector: import("./inspect/inspector.js").Inspector;
  panel: import("./panel/panel.js").Panel;
  toolbar: import("./tools/toolbar.js").Toolbar;
  foot: import("./view/status_bar.js").Foot;
  announcer: import("../ui/announcer.js").Announcer;
  notices: import("./view/notices.js").Notices;
  message: import("../ui/error_message.js").ErrorMessage;
  /** What the person waits for. */
  work: import("./export/work.js").Work;
  clock: import("./place/sun_clock.js").SunClock;
  thumbnails: import("./panel/thumbnails.js").Thumbnails;
}

export type Needs<Name extends keyof Editor> = Pick<Editor, Name>;

export type MakePart<Name extends keyof Editor> = (
  needs: Needs<Name>,
  signal: AbortSignal,
) => import("./part.js").Part;
