// How the land lies: rgb its normal in world coordinates, the shorter the less sure it is, alpha its
// log-depth. A quarter of the size, drawn once a photo.
//
// Along a plane the inverse of the depth is affine in the picture: n · ray / D with ray.z = 1. So a
// weighted least-squares fit of it over a window gives the normal at once, and averages the eight
// bits of the log-depth; texels whose depth is unlike do not count, which keeps edges.

#include "lib/picture.glsl"

uniform sampler2D surface;
uniform vec2 pass_size;

out vec4 result;

const int kReach = 4;        // of the window, in texels
const float kUnlike = 0.6;   // octaves of depth at which a neighbour counts half
const float kNoise = 0.06;   // deviation from the plane, relative, at which it counts half

void main() {
  vec2 place = gl_FragCoord.xy / pass_size;
  float middle = ReadPicture(surface, place).a;
  float total = 0.0;
  vec2 at_mean = vec2(0.0);
  float value_mean = 0.0;
  vec3 spread = vec3(0.0);  // xx, xy, yy
  vec2 slant = vec2(0.0);
  float square = 0.0;
  for (int row = -kReach; row <= kReach; ++row) {
    for (int column = -kReach; column <= kReach; ++column) {
      vec2 at = vec2(column, row);
      vec2 there = place + at / pass_size;
      float inside = step(0.0, min(min(there.x, there.y), min(1.0 - there.x, 1.0 - there.y)));
      float octaves = 16.0 * (ReadPicture(surface, there).a - middle);
      float unlike = octaves / kUnlike;
      float weight = inside / (1.0 + unlike * unlike * unlike * unlike);
      float value = exp2(-octaves);
      total += weight;
      at_mean += weight * at;
      value_mean += weight * value;
      spread += weight * vec3(at.x * at.x, at.x * at.y, at.y * at.y);
      slant += weight * value * at;
      square += weight * value * value;
    }
  }
  at_mean /= total;
  value_mean /= total;
  spread = spread / total - vec3(at_mean.x * at_mean.x, at_mean.x * at_mean.y, at_mean.y * at_mean.y) + vec3(0.05, 0.0, 0.05);
  slant = slant / total - value_mean * at_mean;
  float determinant = spread.x * spread.z - spread.y * spread.y;
  vec2 slope = vec2(spread.z * slant.x - spread.y * slant.y, spread.x * slant.y - spread.y * slant.x) / determinant;
  float rest = max(square / total - value_mean * value_mean - dot(slope, slant), 0.0);

  // From texels to the plane of rays with depth one, where the picture is 1 / focal high.
  vec2 ray = vec2((place.x - 0.5) * frame_size.x / frame_size.y, place.y - 0.5) / camera_focal;
  slope *= pass_size.y * camera_focal * vec2(pass_size.x / pass_size.y * frame_size.y / frame_size.x, 1.0);
  float here = value_mean - dot(slope, at_mean / (pass_size * camera_focal) * vec2(frame_size.x / frame_size.y, 1.0));
  vec3 inward = vec3(slope, here - dot(slope, ray));
  vec3 normal = -inward / max(length(inward), 1e-9);
  vec3 world = vec3(dot(normal, camera_right), dot(normal, camera_up), dot(normal, camera_forward));
  float sure = smoothstep(0.3, 1.5, min(spread.x, spread.z)) / (1.0 + rest / (kNoise * kNoise));
  result = vec4(sure * world, middle);
}
