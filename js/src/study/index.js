/** The anywidget module of Study. */

import { widget } from "../host/mount.js";
import { View } from "./view.js";

/** A notebook keeps the answers, not the pictures: they are megabytes each. */
const withoutPictures = () => ({ _pictures: [] });

export default widget("Study", "Study", "sw-study", View, withoutPictures);
