// One pixel: the opacity of haze, which un-mixing classifies as cloud but which the photo's sun shines through, so
// that it does not shade the land. The clouds' mean if the land is sunlit, 0 if it is in shade. Drawn once per photo.

#include "frame/picture.glsl"
#include "land/land_mean.glsl"

uniform sampler2D openness;

out vec4 result;

// Sunlit shares of the land at which the photo's sun begins to count as shining, and fully counts.
const vec2 kShines = vec2(0.05, 0.2);

void main() {
  vec2 land = vec2(0.0, 1e-3);
  for (int i = 0; i < kTaps; ++i) {
    land += GetDryLand(GetTap(i)) * vec2(ReadRelief(GetTap(i)).lit, 1.0);
  }
  result = vec4(GetMeanCover(openness, 0.0) * smoothstep(kShines.x, kShines.y, land.x / land.y));
}
