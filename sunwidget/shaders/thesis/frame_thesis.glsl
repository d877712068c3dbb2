// The picture by the founding thesis' method (M. Türe, METU 2017, chapter 3). Equation numbers
// are the thesis'. Method 1, "thesis": errata corrected; method 2, "thesis_literal": as
// printed, for teaching. All colors here are display-linear, as in the thesis.

#include "frame/picture.glsl"
#include "frame/strip.glsl"
#include "camera/response.glsl"
#include "atmosphere/read_sky_view.glsl"
#include "thesis/reinhard.glsl"
#include "thesis/thesis_sky.glsl"
#include "frame/output.glsl"

uniform sampler2D retouched;
uniform sampler2D layers;
uniform sampler2D sky_source;
uniform sampler2D sky_edit;
uniform sampler2D thesis_blur_source;
uniform sampler2D thesis_blur_edit;

flat in vec4 model_mean;  // thesis_constants.glsl
flat in vec4 model_deviation;
flat in vec4 land_change;
flat in vec4 disc_extent;
flat in vec4 disc_height;
flat in vec4 disc_path[3];

uniform int method;
uniform vec3 sky_gain;
uniform float altitude;
uniform float sun_visibility;
uniform float cloud_ratio_min;
uniform float cloud_ratio_max;
uniform float blend_distance;
uniform float blend_power;

// As in GetSunDiscRadiance, but with the transmittance of the air as a parabola over the disc's height.
RadianceSpectrum GetDiscRadiance(vec3 view) {
  float radius = disc_extent.a;
  float softness = 1.0 / (camera_focal * frame_size.y);
  float chord = length(view - disc_extent.xyz);
  float coverage = step(1e-9, radius) * clamp((radius - chord) / softness + 0.5, 0.0, 1.0);
  float risen = clamp((view.y - GetCosineOfHorizon(altitude)) / softness + 0.5, 0.0, 1.0);
  float x = min(chord / max(radius, 1e-9), 1.0);
  vec4 limb = 0.5 * log2(max(1.0 - x * x, 1e-4)) * kLimbDarkening;
  float height = clamp((view.y - disc_height.x) * disc_height.y, -1.0, 1.0);
  vec4 path = disc_path[0] + height * (disc_path[1] + height * disc_path[2]);
  vec4 radiance = kSolarIrradiance / (kPi * kSunAngularRadius * kSunAngularRadius) * (0.5 * kLimbDarkening + 1.0);
  return coverage * risen * radiance * exp2(path + limb);
}

void main() {
  vec2 pixel = GetPixel();
  vec2 place = pixel / frame_size;
  ivec2 texel = ivec2(pixel - tile_origin);
  vec3 view = GetViewDirection(place);
  vec4 retouched_texel = texelFetch(retouched, texel, 0);
  vec3 color = retouched_texel.rgb;
  vec4 layer = ReadPixel(layers, place);

  // The rendered sky with the disc; the mask is F', the new sun mask.
  vec3 sky_first = GetThesisSky(texelFetch(sky_source, texel, 0).rgb, model_mean.rgb, model_deviation.rgb);
  vec3 sky_now = GetThesisSky(texelFetch(sky_edit, texel, 0).rgb, model_mean.rgb, model_deviation.rgb);
  vec3 disc = sky_gain * max(SpectralToRec709(GetDiscRadiance(view)), vec3(0.0));
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
  vec2 apart = (place - GetPlaceOfDirection(disc_extent.xyz).xy) * vec2(1.0, frame_size.y / frame_size.x);
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
  vec3 land = color * land_change.rgb;
  float luminance = max(GetLuminance(land), 1e-6);
  land = pow(max(land / luminance, vec3(1e-6)), vec3(land_change.a)) * luminance;      // 3.8

  WriteFrame(color, mix(land, background, layer.r) - color, pixel);            // 3.16
}
