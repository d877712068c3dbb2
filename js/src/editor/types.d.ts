/** The components of the editor's view. A part or tool lists what it needs and gets no more. */
export interface Editor {
  root: HTMLElement;
  model: import("../host/types.js").Model;
  /** The edit, its history, versions and key frames. */
  state: import("../edit/state.js").EditState;
  channel: import("../host/channel.js").Channel;
  kernel: import("./view/kernel.js").Kernel;
  /** What is shown: scene, camera, and the edit or a moment of a film. */
  picture: import("./view/picture.js").Picture;
  /** Where it is shown: canvas, overlay, zoom. */
  stage: import("./view/stage.js").Stage;
  /** Draws it: the frame and its schedule. */
  drawing: import("./view/drawing.js").Drawing;
  original: import("./view/original.js").Original;
  split: import("./view/split.js").Split;
  fullScreen: import("./view/full_screen.js").FullScreen;
  /** Passes events to all parts. */
  parts: import("./part.js").Parts;
  /** The selected tool, its brush and the pointer that drags. */
  hand: import("./tools/hand.js").Hand;
  strokes: import("./tools/strokes.js").StrokesLayer;
  inspector: import("./inspect/inspector.js").Inspector;
  panel: import("./panel/panel.js").Panel;
  toolbar: import("./tools/toolbar.js").Toolbar;
  statusBar: import("./view/status_bar.js").StatusBar;
  announcer: import("../ui/announcer.js").Announcer;
  notices: import("./view/notices.js").Notices;
  message: import("../ui/error_message.js").ErrorMessage;
  /** Long work that the user waits for. */
  work: import("./export/work.js").Work;
  clock: import("./place/sun_clock.js").SunClock;
  thumbnails: import("./panel/thumbnails.js").Thumbnails;
}

export type Needs<Name extends keyof Editor> = Pick<Editor, Name>;

export type MakePart<Name extends keyof Editor> = (
  needs: Needs<Name>,
  signal: AbortSignal,
) => import("./part.js").Part;
