// How much of the land's light is its own, and how much is a mirror image.

const float kMostUpright = 0.8;
// The brightest that lights as land does, over white paint on level ground: a slope may face the sun, and the photo's
// light is known to a factor of two. Less by so much where water may glitter.
const float kWhitest = 2.0;
const float kGlitters = 1.6;

// What rises above the horizon stands upright.
float GetUprightness(vec3 view) {
  return kMostUpright * smoothstep(-0.06, 0.05, view.y);
}

// What exceeds that in this light is a mirror image of the sky and the sun (wet road, glass,
// water that is not known for it): that part follows what it mirrors (mirror_ratio.glsl), the rest
// is lit as land. A mirror image has the light's own color: it is the channel that exceeds least
// that counts, so that red leaves and yellow flowers mirror nothing.
float GetMirrorShare(vec3 light, vec3 lit_before, float glitter) {
  vec3 white = (kWhitest - kGlitters * glitter) / 3.14159265 * lit_before;
  vec3 excess = light / max(white, vec3(1e-9));
  return 1.0 - min(1.0 / max(min(min(excess.r, excess.g), excess.b), 1e-6), 1.0);
}
