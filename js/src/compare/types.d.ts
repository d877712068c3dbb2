/** The components of a comparison's view. A file lists what it needs and gets no more. */
export interface Comparison {
  root: HTMLElement;
  model: import("../host/types.js").Model;
  /** Ends the view. */
  signal: AbortSignal;
  /** The common sun and its history. */
  state: import("../edit/state.js").EditState;
  scenes: import("./scenes.js").Scenes;
  /** Zoom and pan of all pictures. */
  zoom: import("../geometry/zoom.js").Zoom;
  /** Holds the pictures. */
  grid: HTMLElement;
  panels: import("./panel.js").Panel[];
  /** The visible panels. */
  shown: () => import("./panel.js").Panel[];
  variants: () => import("./panel.js").Variant[];
  divider: import("../ui/divider.js").Divider;
  readonly wipes: boolean;
  /** Indices of the wipe's two variants, left and right. */
  pair: number[];
  setPair: (side: number, index: number) => void;
  setArrangement: (arrangement: string) => void;
  setDifference: (on: boolean) => void;
  /** Whether the recipes have their own suns. */
  hasOwnSuns: () => boolean;
}

export type Needs<Name extends keyof Comparison> = Pick<Comparison, Name>;
