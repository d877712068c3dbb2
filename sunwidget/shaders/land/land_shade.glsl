// How the light on land changes that the photo's sun does not reach: rgb the ratio, alpha the log-depth, by which
// the frame chooses among texels. A quarter of the size.

#include "land/lit_land.glsl"

out vec4 result;

void main() {
  LandLight light = GetLandLight(0.0);
  result = vec4(light.ratio, light.level);
}
