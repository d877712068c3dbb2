// Splits the land's light into its own and mirrored light.

const float kMostUpright = 0.8;
// The brightest light still relit as land, in units of white paint on level ground: a slope may face the sun, and the
// photo's light is known to a factor of two. Where water may glitter the limit is lower by kGlitterReduction.
const float kWhitest = 2.0;
const float kGlitterReduction = 1.6;

// Land above the horizon stands upright.
float GetUprightness(vec3 view) {
  return kMostUpright * smoothstep(-0.06, 0.05, view.y);
}

// Share of light beyond kWhitest under the irradiance `lit_before`. It is a mirror image of the sky and the sun (wet
// road, glass, undetected water) and follows what it mirrors (mirror_ratio.glsl); the rest
// is lit as land. A mirror image has the light's own color, so the channel with the least excess
// decides: red leaves and yellow flowers mirror nothing.
float GetMirrorShare(vec3 light, vec3 lit_before, float glitter) {
  vec3 white = (kWhitest - kGlitterReduction * glitter) / 3.14159265 * lit_before;
  vec3 excess = light / max(white, vec3(1e-9));
  return 1.0 - min(1.0 / max(min(min(excess.r, excess.g), excess.b), 1e-6), 1.0);
}
