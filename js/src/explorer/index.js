/** The anywidget module of SkyExplorer. */

import { widget } from "../host/mount.js";
import { Projection } from "./projection.js";
import { SkyFrame } from "./sky_frame.js";
import { View } from "./view.js";

export default widget("SkyExplorer", "Sky explorer", "sw-explorer", View);
// For tests and pages without a kernel.
export { Projection, SkyFrame };
