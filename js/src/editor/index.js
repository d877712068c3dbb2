/** The anywidget module of SunEditor. */

import { Frame } from "../gl/frame.js";
import { Sketch } from "../gl/sketch.js";
import { widget } from "../host/mount.js";
import { savedWithoutView } from "./view/saved.js";
import { View } from "./view/view.js";

export default widget("SunEditor", "Sun editor", "sw-editor", View, savedWithoutView);
// For tests and pages without a kernel.
export { Frame, Sketch };
