/** The anywidget module of Compare. */

import { widget } from "../mount.js";
import { View } from "./view.js";

export default widget("Compare", "Comparison", "sw-compare", View);
