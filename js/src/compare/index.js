/** The anywidget module of Compare. */

import { widget } from "../host/mount.js";
import { savedWithoutView } from "./saved.js";
import { View } from "./view.js";

export default widget("Compare", "Comparison", "sw-compare", View, savedWithoutView);
