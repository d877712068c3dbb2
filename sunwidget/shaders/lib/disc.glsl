// The new sun's disc, in the photo's scene-linear unit: limb-darkened, and reddened on its way.
// terms.glsl holds log2 of its colour as a parabola over its height.

#include "lib/terms.glsl"

// Of the channels: lib/constants.glsl has them at 640, 580, 510 and 440 nm.
const vec3 kLimbDarkening = vec3(0.45, 0.51, 0.63);

vec3 GetDisc(vec3 view, vec3 sun) {
  float radius = term[10].x;
  float softness = 1.0 / (camera_focal * frame_size.y);
  float chord = length(view - sun);
  float coverage = step(1e-9, radius) * clamp((radius - chord) / softness + 0.5, 0.0, 1.0);
  float risen = clamp((view.y - term[10].w) / softness + 0.5, 0.0, 1.0);
  float x = min(chord / max(radius, 1e-9), 1.0);
  float limb = 0.5 * log2(max(1.0 - x * x, 1e-4));
  float height = clamp((view.y - term[10].y) * term[10].z, -1.0, 1.0);
  vec3 middle = vec3(term[1].w, term[2].w, term[3].w);
  vec3 slope = vec3(term[4].w, term[5].w, term[6].w);
  vec3 bend = vec3(term[7].w, term[8].w, term[9].w);
  return coverage * risen * exp2(middle + height * (slope + height * bend) + limb * kLimbDarkening);
}
