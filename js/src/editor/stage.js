/**
 * Where the picture stands: the photo at once, the canvas over it, handles above both.
 *
 * Places on the picture are fractions of its width and height, (0, 0) at the top left corner
 * and also outside 0–1. The overlay lies over the whole stage, margin included, in CSS pixels.
 */

import { element } from "../controls/element.js";
import { PictureStage } from "../stage.js";

/** @typedef {import("../types.js").Point} Point */

const MAXIMUM_ZOOM = 8;

export class Stage extends PictureStage {
  /** @param {AbortSignal} signal */
  constructor(signal) {
    const photo = element("img", { class: "sw-photo", alt: "The photo as it was taken" });
    const canvas = element("canvas", {
      class: "sw-canvas",
      role: "img",
      "aria-label": "The photo with the sun moved",
    });
    const mask = element("canvas", { class: "sw-mask", "aria-hidden": "true" });
    const picture = element("div", { class: "sw-picture" }, photo, canvas, mask);
    super(picture, { content: element("div", { class: "sw-window" }, picture), signal });
    this.photo = photo;
    this.canvas = canvas;
    this.mask = mask;
    this.zoom = 1;
    /** @type {Point} shift of the zoomed picture in CSS pixels */
    this.shift = [0, 0];
    this.url = "";
    signal.addEventListener("abort", () => URL.revokeObjectURL(this.url));
    this.node.addEventListener("wheel", (event) => this.onWheel(event), { passive: false, signal });
  }

  /**
   * Show the photo as it is.
   *
   * @param {ArrayBufferView} bytes PNG or JPEG
   */
  async setPhoto(bytes) {
    const url = URL.createObjectURL(new Blob([/** @type {BlobPart} */ (bytes)]));
    const image = new Image();
    image.src = url;
    await image.decode();
    URL.revokeObjectURL(this.url);
    this.url = url;
    this.photo.src = url;
    this.picture.style.setProperty("--sw-aspect", String(image.naturalWidth / image.naturalHeight));
    this.node.classList.add("sw-has-photo");
  }

  /**
   * Place on the picture of a pointer, also outside it.
   *
   * @param {{ clientX: number, clientY: number }} event
   * @returns {Point}
   */
  placeOf(event) {
    const box = this.picture.getBoundingClientRect();
    return [(event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height];
  }

  /**
   * Where in the overlay a place of the picture is, in CSS pixels.
   *
   * @param {Point} place
   * @returns {Point}
   */
  onOverlay([x, y]) {
    const box = this.rectangle();
    return [box.x + x * box.width, box.y + y * box.height];
  }

  /**
   * Plain wheel scrolls the page; with Ctrl or Cmd it zooms about the pointer.
   *
   * @param {WheelEvent} event
   */
  onWheel(event) {
    if (!event.ctrlKey && !event.metaKey) return;
    event.preventDefault();
    const before = this.placeOf(event);
    const zoom = this.zoom * Math.exp(-event.deltaY * 0.002);
    this.setZoom(zoom);
    const box = this.picture.getBoundingClientRect();
    this.pan(
      event.clientX - (box.left + before[0] * box.width),
      event.clientY - (box.top + before[1] * box.height),
    );
  }

  /** @param {number} zoom */
  setZoom(zoom) {
    this.zoom = Math.min(MAXIMUM_ZOOM, Math.max(1, zoom));
    this.pan(0, 0);
  }

  /**
   * Shift the zoomed picture, never past its own edge.
   *
   * @param {number} x CSS pixels
   * @param {number} y
   */
  pan(x, y) {
    const slackX = ((this.zoom - 1) * this.picture.offsetWidth) / 2;
    const slackY = ((this.zoom - 1) * this.picture.offsetHeight) / 2;
    this.shift = [
      Math.min(slackX, Math.max(-slackX, this.shift[0] + x)),
      Math.min(slackY, Math.max(-slackY, this.shift[1] + y)),
    ];
    this.picture.style.transform =
      this.zoom === 1
        ? ""
        : `translate(${this.shift[0]}px, ${this.shift[1]}px) scale(${this.zoom})`;
    this.node.classList.toggle("sw-zoomed", this.zoom > 1);
    this.onLayout();
  }
}
