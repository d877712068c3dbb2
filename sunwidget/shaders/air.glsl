// The light of the air before distant land, by column of the picture: what an endless path along
// the horizon sends, in the photo's scene-linear unit.

#include "lib/picture.glsl"
#include "lib/sky.glsl"
#include "lib/matched_sky.glsl"

uniform sampler2D sky_view;
uniform vec2 pass_size;

out vec4 result;

void main() {
  vec3 view = GetViewDirection(vec2(gl_FragCoord.x / pass_size.x, 0.5));
  vec3 level = normalize(vec3(view.x, 0.01, view.z));
  result = vec4(GetMatchedSky(sky_view, level), 1.0);
}
