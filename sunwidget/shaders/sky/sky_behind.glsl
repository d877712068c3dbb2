// The sky without the old sun, from the analysis (analysis/backdrop/backdrop.py). Drawn once per photo.
// Alpha packs the other sky values that the frame needs, so that it reads one map for both:
// matte, cloud opacity and glare of the old sun. On water this is the water without the old sun's glints,
// with the waves' share of glints instead of the glare (water_behind.glsl). CLOUDS_UNEDITED as in retouch.glsl.

#include "frame/picture.glsl"
#include "frame/strip.glsl"
#include "frame/packed.glsl"
#include "clouds/cloud_edit.glsl"
#include "clouds/read_added_layer.glsl"
#include "camera/response.glsl"

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
  ivec2 texel = ivec2(gl_FragCoord.xy);
  float opacity = texelFetch(retouched, texel, 0).a;
  vec4 layer = ReadPixel(layers, place);
  vec3 levels = vec3(layer.r, opacity, ReadPixel(surface, place).r);
  vec3 sky = GetBackdropLight(ReadBilinear(backdrop, place).rgb);
#ifndef CLOUDS_UNEDITED
  if (IsCloudEdited()) {
    vec3 model = texelFetch(sky_source, texel, 0).rgb;
    // The same edit as in retouch.glsl; a sky without detail needs no dissolving.
    vec4 open = ReadBilinear(clear_sky, place);
    sky = GetEditedSky(sky, model * DecodeResidual(open.rgb), sky, layer, open.a, 1.0, ReadAddedLayer(place));
  }
#endif
  float water = smoothstep(0.2, 0.5, ReadPixel(surface, place).g) * (1.0 - smoothstep(0.0, 0.2, levels.r));
  vec4 calm = texelFetch(water_behind, texel, 0);
  levels.b += water * (calm.a - levels.b);
  result = vec4(mix(sky, calm.rgb, water), PackLevels(levels));
}
