/** The anywidget module of Study. */

import { widget } from "../mount.js";
import { View } from "./view.js";

export default widget("Study", "Study", "sw-study", View);
