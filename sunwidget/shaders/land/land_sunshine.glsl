// How the light on land changes that the photo's sun reaches: rgb the ratio; alpha how many times the light of
// land in shade falls on it in the photo. A quarter of the size.

#include "land/lit_land.glsl"

out vec4 result;

void main() {
  LandLight light = GetLandLight(1.0);
  result = vec4(light.ratio, max(GetLuminance(light.before) / max(GetLuminance(GetLandLight(0.0).before), 1e-9), 1.0));
}
