// Edits the photo's own clouds: thinner, thicker or softer (clear_sky: analysis/clear_sky.py).

#include "frame/picture.glsl"

uniform sampler2D clear_sky;
uniform float cloud_opacity;
uniform float cloud_softness;

// The thickness of a cloud of opacity 1 is unknown: it counts as this opaque.
const float kThickest = 0.98;

// `opacity` in [0, 1] scaled by cloud_opacity: below 1 in proportion, above 1 by optical depth.
float GetScaledOpacity(float opacity) {
  float thicker = 1.0 - pow(1.0 - min(opacity, kThickest), max(cloud_opacity, 1.0));
  return cloud_opacity > 1.0 ? max(thicker, opacity) : cloud_opacity * opacity;
}

// Weight of dissolved edges over the photo where their opacity is `soft`: above 0 only near edges.
float GetSofteningShare(float soft) {
  return cloud_softness * min(6.0 * soft * (1.0 - soft), 1.0);
}

// `own` and the result are the opacity times the matte, as in `layers`; `soft` is the
// opacity with dissolved edges.
float EditOpacity(float own, float matte, float soft) {
  float opacity = min(own / max(matte, 1.0 / 255.0), 1.0);
  float changed = matte * GetScaledOpacity(mix(opacity, soft, GetSofteningShare(soft)));
  return cloud_opacity == 1.0 && cloud_softness == 0.0 ? own : changed;
}
