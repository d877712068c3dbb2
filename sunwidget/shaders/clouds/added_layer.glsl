// The added clouds under the photo's own sun, at half size: cumulus with flat bases, by a march through
// the layer. rgb is their scene-linear light times alpha, alpha their opacity, both behind the air in
// front of them, which fades them into the sky.
//
// Self-shading is that of multiply scattered light, which fades with the optical depth t towards
// the sun like diffusion, 1 / (1 + 0.13 t) (two-stream, asymmetry 0.85: Bohren 1987).

#include "frame/picture.glsl"
#include "atmosphere/read_sky_view.glsl"
#include "sky/daylight.glsl"
#include "atmosphere/extinction.glsl"
#include "clouds/cloud_layer.glsl"
#include "clouds/forward_lobe.glsl"
#include "camera/response.glsl"

uniform sampler2D light_before;
uniform vec3 cloud_gain;
uniform vec2 pass_size;
uniform float source_sun_azimuth;
uniform float source_sun_elevation;
uniform float source_rayleigh_scale_height;

out vec4 result;

const int kSteps = 18;
const float kThickness = 0.45;     // of the layer; lengths are in cloud sizes
const float kExtinction = 40.0;
const float kLongestPath = 4.0;
const float kWhitest = 0.8;        // display-linear: photographers do not let clouds clip
const float kTallest = 0.34;       // rise of the cover field under the tallest tower

// Towers grow where the field rises; the base is flat.
float GetShape(vec3 at, vec2 warp, vec2 detail) {
  float height = at.y / kThickness;
  float base = 0.12 * (1.0 - smoothstep(0.0, 0.12, height));
  float top = kTallest * max(height, 0.0) * sqrt(max(height, 0.0));
  return GetCoverField(at.xz, warp, detail) - top - base - 2.0 * max(-height, 0.0);
}

// Rounded lumps with sharp creases between them, in up to three sizes.
float GetLumps(vec3 at, vec3 detail) {
  vec3 p = at + vec3(0.0, 0.31 * cloud_pattern, 0.0);
  float lumps = 0.34 * detail.x * (abs(GetNoise(2.7 * p)) - 0.15);
  if (detail.y > 0.0) lumps += 0.20 * detail.y * (abs(GetNoise(6.1 * p)) - 0.15);
  if (detail.z > 0.0) lumps += 0.11 * detail.z * (abs(GetNoise(13.7 * p)) - 0.15);
  return lumps;
}

// Optical depth of a part of the path to the sun. It rises slowly with the shape, so that the inside
// of a cloud is not a uniform gray.
float GetShadeFrom(float shape, float part) {
  return kExtinction * part * clamp(shape / 0.35, 0.0, 1.0);
}

// Visible share of structure of this size where a pixel is `footprint` wide.
float GetDetailShare(float size, float footprint) {
  return 1.0 - smoothstep(0.2 * size, 0.6 * size, footprint);
}

// Transmittance of the photo's own air: clouds are edited before the sun moves.
vec3 GetAirBefore(float far) {
  float top = 1000.0 * added_cloud_height;
  vec3 depth = GetExtinction(source_air_density, 0.0, 1.0, 0.0) * source_rayleigh_scale_height
      * (1.0 - exp(-top / source_rayleigh_scale_height));
  depth += GetExtinction(0.0, source_aerosol_optical_depth, source_aerosol_scale_height, source_angstrom_exponent)
      * source_aerosol_scale_height * (1.0 - exp(-top / source_aerosol_scale_height));
  return exp(-depth * far / added_cloud_height);
}

void main() {
  vec3 view = GetViewDirection(gl_FragCoord.xy / pass_size);
  vec3 sun = GetSunDirection(source_sun_azimuth, source_sun_elevation);
  float near = GetDistanceToLevel(view.y, added_cloud_height);
  float far = GetDistanceToLevel(view.y, added_cloud_height + kThickness * added_cloud_size);
  float path = min((far - near) / added_cloud_size, kLongestPath);
  float stride = path / float(kSteps);
  vec2 start = GetLayerPlace(near * view.xz);
  float climb = kThickness * path * added_cloud_size / max(far - near, 1e-3);

  // A pixel's length along the layer, longer for grazing rays.
  float grazing = near / (camera_focal * min(frame_size.y, 2.0 * pass_size.y)) * near
      / added_cloud_height / added_cloud_size;
  float footprint = max(grazing, 0.4 * stride);
  vec2 detail = vec2(GetDetailShare(1.0, footprint), GetDetailShare(0.5, footprint));
  vec3 fine = vec3(GetDetailShare(0.5, footprint), GetDetailShare(0.22, footprint), GetDetailShare(0.1, footprint));

  vec3 direct = GetLightTexel(light_before, 8) / kPi;
  vec3 above = 0.5 * (GetLightTexel(light_before, 0) + GetLightTexel(light_before, 2)) / kPi;
  vec3 below = 0.15 * (above + max(sun.y, 0.0) * direct);
  // Multiple scattering inside spreads the lobe, so its peak is lower than a single drop's.
  vec3 lobe = 0.12 * min(GetForwardLobe(dot(sun, view)), 8.0) * direct;

  // Where single clouds are smaller than a pixel only their cover counts, and rows of clouds hide
  // the gaps: an even bank.
  float bank = smoothstep(0.4, 1.5, grazing);
  // Neighbors start a quarter of a step apart, because otherwise the steps show as slices; read_added_layer.glsl
  // averages any four of them.
  ivec2 parity = ivec2(gl_FragCoord.xy) & 1;
  // Each starts at random within its quarter, because otherwise large pictures show combs at the fringes.
  float jitter = float(Hash(uint(gl_FragCoord.x) + Hash(uint(gl_FragCoord.y))) >> 8u) / 16777216.0;
  float offset = 0.5 * float(parity.x ^ parity.y) + 0.25 * (float(parity.y) + jitter);
  float edge = 0.08 + 0.5 * stride;

  vec3 light = vec3(0.0);
  float through = 1.0;
  for (int i = 0; i < kSteps; ++i) {
    if (view.y < -0.01 || through < 0.01) break;
    float part = (float(i) + offset) / float(kSteps);
    vec3 at = vec3(start + part * path * view.xz, part * climb).xzy;
    vec2 warp = GetWarp(at.xz);
    float density = smoothstep(0.0, edge, GetShape(at, warp, detail) + GetLumps(at, fine));
    vec3 next = at + 0.07 * sun;
    float shade = GetShadeFrom(GetShape(next, warp, detail) + GetLumps(next, vec3(fine.x, 0.0, 0.0)), 0.12)
        + GetShadeFrom(GetShape(at + 0.25 * sun, warp, vec2(detail.x, 0.0)), 0.30)
        + GetShadeFrom(GetShape(at + 0.70 * sun, warp, vec2(0.0)), 0.50);
    float height = clamp(at.y / kThickness, 0.0, 1.0);
    vec3 lit = direct * (0.1 * exp(-0.5 * shade) + 0.5 / (1.0 + 0.13 * shade))
        + lobe * exp(-0.6 * shade) + above * (0.4 + 0.6 * height) + below * (1.0 - height);
    float passed = exp(-kExtinction * density * stride);
    light += through * (1.0 - passed) * lit;
    through *= passed;
  }
  float covered = mix(1.0 - through, pow(added_clouds, 0.6), bank);
  light = mix(light, covered * (0.35 * direct + 0.8 * above), bank);
  float share = smoothstep(0.0, 0.02, added_clouds) * smoothstep(-0.004, 0.004, view.y);
  vec3 air = share * GetAirBefore(near);
  vec3 white = cloud_gain * (0.6 * direct + above);
  vec3 gain = cloud_gain * min(1.0, GetSceneLight(vec3(kWhitest)).g / max(GetLuminance(white), 1e-6));
  result = vec4(gain * light * air, covered * air.g);
}
