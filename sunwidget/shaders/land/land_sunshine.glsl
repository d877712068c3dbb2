// Change of the light on land lit by the photo's sun: rgb the ratio; alpha its irradiance in the photo
// relative to that of land in shade. A quarter of the size.

#include "land/lit_land.glsl"

out vec4 result;

void main() {
  LandLight light = GetLandLight(1.0);
  result = vec4(light.ratio, max(GetLuminance(light.before) / max(GetLuminance(GetLandLight(0.0).before), 1e-9), 1.0));
}
