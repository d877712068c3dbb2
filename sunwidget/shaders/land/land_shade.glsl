// Change of the light on land in shade of the photo's sun: rgb the ratio, alpha the log-depth, by which
// the frame weights texels. A quarter of the size.

#include "land/lit_land.glsl"

out vec4 result;

void main() {
  LandLight light = GetLandLight(0.0);
  result = vec4(light.ratio, light.level);
}
