/** The anywidget module of Study. */

import { widget } from "../host/mount.js";
import { View } from "./view.js";

/** A notebook saves the answers but not the pictures, which are megabytes each. */
const withoutPictures = () => ({ _pictures: [] });

export default widget("Study", "Study", "sw-study", View, withoutPictures);
