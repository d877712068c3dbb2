/** The study's pictures as image elements, decoded before they are shown. */

import { element } from "../ui/element.js";

export class Pictures {
  /**
   * @param {ArrayBufferView[]} bytes PNG or JPEG each
   * @param {AbortSignal} signal frees them
   */
  constructor(bytes, signal) {
    this.bytes = bytes;
    /** @type {Map<number, string>} addresses by index */
    this.urls = new Map();
    signal.addEventListener("abort", () => {
      for (const url of this.urls.values()) URL.revokeObjectURL(url);
    });
  }

  /**
   * Load a decoded picture. Its file name, and so its method, appears nowhere in the page.
   *
   * @param {number} index
   * @returns {Promise<HTMLImageElement>}
   */
  async load(index) {
    let url = this.urls.get(index);
    if (!url) {
      url = URL.createObjectURL(new Blob([/** @type {BlobPart} */ (this.bytes[index])]));
      this.urls.set(index, url);
    }
    const image = element("img", { src: url, draggable: "false" });
    await image.decode();
    return image;
  }
}
