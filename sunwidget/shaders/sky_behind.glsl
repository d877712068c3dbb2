// The sky without the old sun: matched model times the slow residual that the analysis filled
// across the glare (analysis/backdrop.py). Drawn once a photo. Alpha carries what else the frame
// asks about the sky of a pixel, so that it reads one map for both: matte, cloud opacity and
// glare of the old sun. On water it is the water without the old sun's glints, and its waves
// instead of the glare (water_behind.glsl).

#include "lib/picture.glsl"
#include "lib/packed.glsl"

uniform sampler2D sky_source;
uniform sampler2D backdrop;
uniform sampler2D layers;
uniform sampler2D retouched;
uniform sampler2D surface;
uniform sampler2D water_behind;
uniform vec2 tile_origin;

out vec4 result;

void main() {
  vec2 place = (gl_FragCoord.xy + tile_origin) / frame_size;
  vec3 residual = exp(4.0 * ReadBilinear(backdrop, place).rgb - 2.0);
  ivec2 texel = ivec2(gl_FragCoord.xy);
  float opacity = texelFetch(retouched, texel, 0).a;
  vec3 levels = vec3(ReadPicture(layers, place).r, opacity, ReadPicture(surface, place).r);
  vec3 sky = texelFetch(sky_source, texel, 0).rgb * residual;
  float water = smoothstep(0.0, 0.2, ReadPicture(surface, place).g) * (1.0 - smoothstep(0.0, 0.2, levels.r));
  vec4 calm = texelFetch(water_behind, texel, 0);
  levels.b += water * (calm.a - levels.b);
  result = vec4(mix(sky, calm.rgb, water), PackLevels(levels));
}
