// Mean openness of the picture towards the sun on rings around it: radius along x, from the sun to
// kLargestRing. The model's sky contains the mean amount of lit haze; shafts are the deviations
// from it.

#include "camera/read_shafts.glsl"

uniform vec2 pass_size;

out vec4 result;

const int kAngles = 72;

void main() {
  vec3 sun = GetShaftSun();
  float radius = kLargestRing * (gl_FragCoord.x - 0.5) / (pass_size.x - 1.0);
  float sum = 0.0;
  float norm = 1e-4;
  for (int i = 0; i < kAngles; ++i) {
    float turn = 6.2831853 * float(i) / float(kAngles);
    vec2 place = sun.xy + radius * vec2(cos(turn) / GetAspect(), sin(turn));
    // Count only places inside the picture, with a soft edge, so that a drag causes no step.
    vec2 inside = smoothstep(vec2(-0.05), vec2(0.05), min(place, 1.0 - place));
    vec2 shaft = GetShaft(place, sun.xy);
    float weight = inside.x * inside.y * shaft.y;
    sum += weight * shaft.x;
    norm += weight;
  }
  result = vec4(sum / norm, norm, 0.0, 1.0);
}
