/**
 * Two matrices of `sunwidget/atmosphere/constants.json`, compared by a test: the whole file would add
 * ten kilobytes to the bundle.
 */

/** Radiance at 640, 580, 510, 440 nm in W m⁻² sr⁻¹ nm⁻¹ to CIE XYZ in kcd m⁻². */
export const SPECTRAL_TO_XYZ = [
  [19.83692, 37.21109, 4.907598, 10.47804],
  [7.24235, 38.32887, 26.61338, -0.1732886],
  [0.5990631, -3.850443, 21.32421, 56.16503],
];

/** CIE XYZ to linear Rec. 709. */
export const XYZ_TO_REC709 = [
  [3.2404542, -1.5371385, -0.4985314],
  [-0.969266, 1.8760108, 0.041556],
  [0.0556434, -0.2040259, 1.0572252],
];
