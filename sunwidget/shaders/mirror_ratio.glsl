// How the mirror image in level water changes from the photo's sun to the moved one. The sun
// itself is mirrored where the photo glitters, the sky elsewhere.

#include "lib/picture.glsl"
#include "lib/response.glsl"

uniform sampler2D mirror_source;
uniform sampler2D mirror_edit;
uniform sampler2D surface;
uniform sampler2D terms;
uniform vec2 pass_size;

out vec4 result;

// A clipped glint does not say how bright it was: let it fade freely, but hardly grow.
const float kLargestGrowth = 2.0;

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy);
  float glitter = ReadBilinear(surface, gl_FragCoord.xy / pass_size).b;
  vec4 before = texelFetch(mirror_source, texel, 0);
  vec4 now = texelFetch(mirror_edit, texel, 0);
  vec3 ratio = GetRatio(now.rgb + glitter * now.a * texelFetch(terms, ivec2(12, 0), 0).rgb,
                        before.rgb + glitter * before.a * texelFetch(terms, ivec2(11, 0), 0).rgb);
  result = vec4(min(ratio, vec3(kLargestGrowth)), 1.0);
}
