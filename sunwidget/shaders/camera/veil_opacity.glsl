// One pixel: the opacity of what un-mixing calls cloud and the photo's sun shines through, so that it takes no light
// from the land: haze. The mean of the clouds where the land is lit, 0 where it lies in shade. Drawn once a photo.

#include "frame/picture.glsl"
#include "land/land_mean.glsl"

uniform sampler2D openness;

out vec4 result;

// Share of the land that the photo's sun reaches, from which and by which it shines.
const vec2 kShines = vec2(0.05, 0.2);

void main() {
  vec2 land = vec2(0.0, 1e-3);
  for (int i = 0; i < kTaps; ++i) {
    land += GetDryLand(GetTap(i)) * vec2(ReadRelief(GetTap(i)).lit, 1.0);
  }
  result = vec4(GetMeanCover(openness, 0.0) * smoothstep(kShines.x, kShines.y, land.x / land.y));
}
