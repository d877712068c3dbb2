// How the land's irradiance changes from the photo's sun to the moved one, per surface: rgb the
// ratio, alpha the log-depth of the land here, by which the frame chooses among its texels.

#include "lib/picture.glsl"
#include "lib/response.glsl"
#include "lib/land.glsl"

uniform sampler2D terms;
uniform sampler2D surface;
uniform vec2 pass_size;

out vec4 result;

void main() {
  vec2 place = gl_FragCoord.xy / pass_size;
  float upright = GetUprightness(GetViewDirection(place));
  vec3 before = mix(texelFetch(terms, ivec2(1, 0), 0).rgb, texelFetch(terms, ivec2(2, 0), 0).rgb, upright);
  vec3 now = mix(texelFetch(terms, ivec2(3, 0), 0).rgb, texelFetch(terms, ivec2(4, 0), 0).rgb, upright);
  result = vec4(GetRatio(now, before), ReadBilinear(surface, place).a);
}
