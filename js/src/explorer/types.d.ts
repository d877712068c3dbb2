import type { Parameter, Point } from "../host/types.js";

/** The components of the explorer's view. Each file lists what it needs and gets no more. */
export interface Explorer {
  id: string;
  root: HTMLElement;
  model: import("../host/types.js").Model;
  /** The kernel's table. */
  parameters: Parameter[];
  state: import("../edit/state.js").EditState;
  channel: import("../host/channel.js").Channel;
  sun: import("./sun.js").Sun;
  stage: import("./stage.js").SkyStage;
  frame: import("./sky_frame.js").SkyFrame;
  tracer: import("./tracer.js").Tracer;
  handle: import("./sun_handle.js").SunHandle;
  measured: import("./measured.js").Measured;
  message: import("../ui/error_message.js").ErrorMessage;
  /** Key of the drawn picture. */
  drawnKey: string;
  /** Number of tables that the kernel has sent. */
  tables: number;

  parameter: (name: string) => Parameter;
  /** A parameter's value. */
  number: (name: string) => number;
  clamp: (name: string, value: number) => number;

  /** Return a direction's place on the picture, or null behind the camera. */
  placeOf: (direction: Point) => Point | null;
  /** Return the direction at a place, or null outside the sky. */
  directionOf: (place: Point) => Point | null;
  /** As `directionOf`, or else the nearest direction toward the picture's middle. */
  nearestDirection: (place: Point) => Point | null;
  /** Degrees that the view turns per pixel. */
  degreesPerPixel: () => number;
  /** Return the model's radiances at the four wavelengths in the given directions. */
  radiances: (directions: Point[]) => Float32Array | null;

  /** Set the direction under the pointer. */
  hover: (direction: Point | null) => void;
  /** Highlight a direction for a plot. */
  point: (direction: Point | null) => void;
  /** Update everything from the state. */
  show: () => void;
  requestFrame: () => void;
}

export type Needs<Name extends keyof Explorer> = Pick<Explorer, Name>;
