// The sky without the old sun: matched model times the slow residual that the analysis filled
// across the glare (analysis/backdrop.py). Drawn once a photo.

#include "lib/picture.glsl"

uniform sampler2D sky_source;
uniform sampler2D backdrop;
uniform vec2 tile_origin;

out vec4 result;

void main() {
  vec2 place = (gl_FragCoord.xy + tile_origin) / frame_size;
  vec3 residual = exp(4.0 * ReadBilinear(backdrop, place).rgb - 2.0);
  result = vec4(texelFetch(sky_source, ivec2(gl_FragCoord.xy), 0).rgb * residual, 1.0);
}
