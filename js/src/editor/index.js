/** The anywidget module of SunEditor. */

import { Frame } from "../frame.js";
import { Sketch } from "../gl/sketch.js";
import { widget } from "../mount.js";
import { unseen } from "./saved.js";
import { View } from "./view.js";

export default widget("SunEditor", "Sun editor", "sw-editor", View, unseen);
// For tests and for pages without a kernel.
export { Frame, Sketch };
