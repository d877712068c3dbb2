// The picture as the founding thesis makes it (M. Türe, METU 2017, chapter 3). Equation numbers
// are the thesis'. method 1, "thesis": the errata corrected; method 2, "thesis_literal": as
// printed, for teaching. All colours here are display-linear, as the thesis has them.

#include "frame/picture.glsl"
#include "frame/strip.glsl"
#include "camera/response.glsl"
#include "atmosphere/read_sky_view.glsl"
#include "sky/daylight.glsl"
#include "thesis/reinhard.glsl"
#include "thesis/thesis_sky.glsl"
#include "frame/output.glsl"

uniform sampler2D retouched;
uniform sampler2D columns;
uniform sampler2D layers;
uniform sampler2D sky_source;
uniform sampler2D sky_edit;
uniform sampler2D light_before;
uniform sampler2D light_edit;
uniform sampler2D visibility_source;
uniform sampler2D visibility_edit;
uniform sampler2D thesis_statistics;
uniform sampler2D thesis_mean_source;
uniform sampler2D thesis_mean_edit;
uniform sampler2D thesis_blur_source;
uniform sampler2D thesis_blur_edit;

uniform int method;
uniform vec3 sky_gain;
uniform float sun_azimuth;
uniform float sun_elevation;
uniform float altitude;
uniform float sun_size;
uniform float sun_visibility;
uniform float sun_sky_ratio;
uniform float thesis_saturation;
uniform float cloud_ratio_min;
uniform float cloud_ratio_max;
uniform float blend_distance;
uniform float blend_power;
uniform vec3 photo_sky_linear_mean;   // S̄ of the photo
uniform vec3 photo_land_linear_mean;  // F̄ of the photo
uniform float sun_mask_share;         // sun mask pixels over sky pixels, in the photo

// The colour of the sun's light: what is left of white after its way through the air.
vec3 GetSunColor(sampler2D light) {
  vec3 sun = GetLightTexel(light, 7);
  return sun / max(GetLuminance(sun), 1e-9);
}

// S̄ with the sun's pixels amplified by F^s. Corrected: the disc adds a fixed share of the sky's
// mean (the true disc at F^s = 1000 adds a quarter), dimmed by its way through the air; printed:
// the weight falls on the mask's pixels, whatever their number.
vec3 GetSkyMean(vec3 mean, sampler2D light, float visible) {
  if (method == 2) {
    float share = sun_sky_ratio * sun_mask_share * visible;
    return (mean + share * vec3(1.0)) / (1.0 + share);
  }
  float beam = GetLuminance(GetLightTexel(light, 1)) / max(GetLuminance(GetLightTexel(light_before, 7)), 1e-9);
  return mean + 0.25 * sun_sky_ratio / 1000.0 * visible * beam * GetLuminance(texelFetch(thesis_mean_source, ivec2(0), 0).rgb) * GetSunColor(light);
}

void main() {
  vec2 pixel = GetPixel();
  vec2 place = pixel / frame_size;
  ivec2 texel = ivec2(pixel - tile_origin);
  vec3 view = GetViewDirection(place);
  vec4 retouched_texel = texelFetch(retouched, texel, 0);
  vec3 color = retouched_texel.rgb;
  vec4 layer = ReadPixel(layers, place);
  vec3 sun = GetSunDirection(sun_azimuth, sun_elevation);
  float visible_before = texelFetch(visibility_source, ivec2(0), 0).r;
  float visible_now = texelFetch(visibility_edit, ivec2(0), 0).r;

  // The rendered sky, with the disc: F' is the new sun mask.
  vec3 sky_first = GetThesisSky(texelFetch(sky_source, texel, 0).rgb, thesis_statistics);
  vec3 sky_now = GetThesisSky(texelFetch(sky_edit, texel, 0).rgb, thesis_statistics);
  float pixel_angle = 1.0 / (camera_focal * frame_size.y);
  vec3 disc = sky_gain * max(SpectralToRec709(GetSunDiscRadiance(columns, view, sun, altitude, sun_size, pixel_angle)), vec3(0.0));
  float mask = sun_visibility * min(GetLuminance(disc), 1.0);
  sky_now = mix(sky_now, GetDisplayLight(disc), mask);

  // Clouds, eq. 3.5–3.6, on encoded values; then 3.9–3.14.
  vec3 code = EncodeSrgb(color);
  float ratio = code.r / max(code.b, 1.0 / 255.0);
  float softness = (ratio - cloud_ratio_min) / max(cloud_ratio_max - cloud_ratio_min, 1e-3);
  float opacity = retouched_texel.a;
  if (method == 2) {
    opacity = step(cloud_ratio_min, ratio);
  } else {
    softness = clamp(softness, 0.0, 1.0);
  }
  vec3 thick = color * sky_now / max(sky_first, vec3(1e-3));                   // 3.10
  vec2 apart = (place - GetPlaceOfDirection(sun).xy) * vec2(1.0, frame_size.y / frame_size.x);
  float near = 1.0 - min(length(apart) / blend_distance, 1.0);                 // 3.12
  vec3 blur_now = ReadBilinear(thesis_blur_edit, place).rgb;
  vec3 soft;
  if (method == 2) {
    soft = mix(color, sky_first, mask);                                        // 3.11 as printed
    soft = soft * blur_now * near + soft * (1.0 - near);                       // 3.13 as printed
  } else {
    near = pow(near, blend_power);
    // 3.11 through the cloud: an opaque one hides the new sun instead of turning black.
    soft = mix(color, sky_now, mask * (1.0 - opacity));
    vec3 blur_first = max(ReadBilinear(thesis_blur_source, place).rgb, vec3(1e-3));
    soft *= blur_now / blur_first * near + (1.0 - near);                       // 3.13
  }
  vec3 cloud = soft * softness + thick * (1.0 - softness);                     // 3.14
  vec3 background = mix(sky_now, cloud, opacity);                              // 3.15

  // Land, eq. 3.7 and 3.8.
  vec3 mean_now = GetSkyMean(texelFetch(thesis_mean_edit, ivec2(0), 0).rgb, light_edit, visible_now);
  vec3 land;
  if (method == 2) {
    vec3 mean_photo = GetSkyMean(photo_sky_linear_mean, light_before, 1.0);
    vec3 land_mean = max(photo_land_linear_mean, vec3(1e-3));
    land = color * (mean_photo / land_mean) * mean_now / land_mean;            // 3.7 as printed
  } else {
    vec3 mean_first = GetSkyMean(texelFetch(thesis_mean_source, ivec2(0), 0).rgb, light_before, visible_before);
    land = color * mean_now / max(mean_first, vec3(1e-4));                     // 3.7
  }
  float power = 1.0 - (1.0 - thesis_saturation) * clamp(visible_before - visible_now, 0.0, 1.0);
  float luminance = max(GetLuminance(land), 1e-6);
  land = pow(max(land / luminance, vec3(1e-6)), vec3(power)) * luminance;      // 3.8

  WriteFrame(color, mix(land, background, layer.r) - color, pixel);            // 3.16
}
