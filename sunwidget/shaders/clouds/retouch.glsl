// The photo with edited clouds under its own sun, display-linear; alpha is the clouds' opacity
// after the edit. Later passes use it as the photo, so that a moved sun costs the same with edited
// clouds as with the photo's own. CLOUDS_UNEDITED omits what only edited clouds need
// (cloud_parts.glsl), with the same result to the bit.

#include "frame/picture.glsl"
#include "frame/strip.glsl"
#include "clouds/cloud_edit.glsl"
#include "clouds/read_added_layer.glsl"
#include "camera/response.glsl"
#include "atmosphere/read_sky_view.glsl"

uniform sampler2D photo;
uniform sampler2D layers;
uniform sampler2D surface;
uniform sampler2D backdrop;
uniform sampler2D sky_source;
uniform sampler2D soft_sky;
uniform float source_sun_azimuth;
uniform float source_sun_elevation;
uniform vec2 tile_origin;

out vec4 result;

const float kCore = 0.03;  // radians around the sun

// Log of a pixel's light over that of its surroundings, limited to amplitudes of grain.
vec3 GetGrain(ivec2 texel, vec3 light) {
  vec3 sum = vec3(0.0);
  for (int i = 0; i < 9; ++i) {
    sum += FetchPixel(photo, texel + ivec2(i % 3, i / 3) - 1).rgb;
  }
  vec3 grain = log(max(light, vec3(1e-4)) / max(sum / 9.0, vec3(1e-4)));
  return grain / (1.0 + 30.0 * abs(grain));
}

void main() {
  vec2 place = (gl_FragCoord.xy + tile_origin) / frame_size;
  vec3 display = ReadPixel(photo, place).rgb;
  vec4 layer = ReadPixel(layers, place);
#ifdef CLOUDS_UNEDITED
  result = vec4(display, layer.g);
#else
  vec4 behind = ReadBilinear(clear_sky, place);
  vec4 added = ReadAddedLayer(place);
  float opacity = EditOpacity(layer.g, layer.r, behind.a);
  result = vec4(display, opacity + (layer.r - opacity) * added.a);
  if (!IsCloudEdited()) return;

  vec3 model = texelFetch(sky_source, ivec2(gl_FragCoord.xy), 0).rgb;
  vec3 clear = model * DecodeResidual(behind.rgb);
  vec3 dissolved = ReadBilinear(soft_sky, place).rgb;
  // Where the matte is soft the pixel's own light is partly land.
  vec3 scene = GetSceneLight(display);
  vec3 slow = GetBackdropLight(ReadBilinear(backdrop, place).rgb);
  vec3 light = mix(slow, scene, smoothstep(0.85, 1.0, layer.r));
  // Near the sun's core a clipped pixel is sun, not cloud.
  float from_sun = length(GetViewDirection(place) - GetSunDirection(source_sun_azimuth, source_sun_elevation));
  float confidence = 1.0 - ReadPixel(surface, place).r * (1.0 - smoothstep(kCore, 3.0 * kCore, from_sun));
  vec3 edited = GetEditedSky(light, clear, dissolved, layer, behind.a, confidence, added);

  // Light that replaces the photo's gets the photo's grain.
  vec3 kept = clamp(1.0 - abs(edited - light) / max(max(edited, light), vec3(1e-6)), 0.0, 1.0);
  vec3 grain = GetGrain(ivec2(place * vec2(GetPictureSize(photo))), display);
  edited *= exp((1.0 - kept) * smoothstep(0.85, 1.0, layer.r) * grain);

  vec3 change = layer.r * (edited - light);
  vec3 changed = GetDisplayLight(max(scene + change, 0.02 * scene));
  vec3 representable = clamp(display, vec3(0.0), vec3(GetWhiteLevel()));
  result.rgb += step(1e-30, dot(abs(change), vec3(1.0))) * (changed - representable);
#endif
}
