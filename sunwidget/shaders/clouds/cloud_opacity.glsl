// The photo's own clouds, thinner, thicker or softer (clear_sky: analysis/clear_sky.py).

#include "frame/picture.glsl"

uniform sampler2D clear_sky;
uniform float cloud_opacity;
uniform float cloud_softness;

// Of a cloud of opacity 1 there is no knowing how thick it is: it counts as this opaque.
const float kThickest = 0.98;

// `opacity` in [0, 1] times cloud_opacity: thinner in proportion, thicker as optical depth grows.
float GetThinned(float opacity) {
  float thicker = 1.0 - pow(1.0 - min(opacity, kThickest), max(cloud_opacity, 1.0));
  return cloud_opacity > 1.0 ? max(thicker, opacity) : cloud_opacity * opacity;
}

// How far dissolved edges replace the photo where their opacity is `soft`: only near edges.
float GetSoftened(float soft) {
  return cloud_softness * min(6.0 * soft * (1.0 - soft), 1.0);
}

// `own` is the opacity times the matte, as `layers` holds it, and so is the result; `soft` the
// opacity with dissolved edges.
float EditOpacity(float own, float matte, float soft) {
  float opacity = min(own / max(matte, 1.0 / 255.0), 1.0);
  float changed = matte * GetThinned(mix(opacity, soft, GetSoftened(soft)));
  return cloud_opacity == 1.0 && cloud_softness == 0.0 ? own : changed;
}
