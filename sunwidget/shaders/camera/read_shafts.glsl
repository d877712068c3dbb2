// Light shafts: where land or clouds stand before the sun the haze behind them is not lit. The
// picture itself tells what stands there: from each pixel towards the sun's place it is asked how
// open it is (Mitchell 2007, "Volumetric light scattering as a post-process", GPU Gems 3, ch. 13).

#include "frame/picture.glsl"
#include "atmosphere/read_sky_view.glsl"

uniform sampler2D openness;
uniform float sun_azimuth;
uniform float sun_elevation;

const int kShaftSteps = 24;
// Farther than this (in heights of the picture) nothing is asked: what the sun shines through
// there is as wide as a beam.
const float kLongestShaft = 1.2;
// The rings of shaft_rings.glsl reach this far from the sun, in heights of the picture.
const float kLargestRing = 3.2;

float GetAspect() {
  return frame_size.x / frame_size.y;
}

// Where the sun is, fractions of the picture; z is how far it lies before the camera, 0 to 1. From
// outside the picture beams come nearly parallel: suns farther out count as this far out.
vec3 GetShaftSun() {
  vec3 at = GetPlaceOfDirection(GetSunDirection(sun_azimuth, sun_elevation));
  return vec3(clamp(at.xy, vec2(-1.0), vec2(2.0)), smoothstep(0.0, 0.3, at.z));
}

// Mean openness from `place` towards `sun`, what is near the pixel first, and the share of the way
// that tells it; fractions of the picture.
vec2 GetShaft(vec2 place, vec2 sun) {
  vec2 path = sun - place;
  path *= min(1.0, kLongestShaft / max(length(path * vec2(GetAspect(), 1.0)), 1e-4));
  vec2 sum = vec2(0.0);
  float norm = 0.0;
  for (int i = 0; i < kShaftSteps; ++i) {
    float t = (float(i) + 0.5) / float(kShaftSteps);
    float weight = 1.0 - 0.6 * t;
    sum += weight * ReadBilinear(openness, place + t * path).rg;
    norm += weight;
  }
  return vec2(sum.r / max(sum.g, 1e-4), sum.g / norm);
}

// What ten kilometres of this haze send from `cosine` off the sun, per unit of the sun's
// irradiance: clear air shows almost none. Far along a beam light comes scattered twice: the lobe is wider.
float GetHazeLight(float cosine) {
  const float kPath = 10000.0;  // m
  float depth = kPath * aerosol_optical_depth / aerosol_scale_height;
  return aerosol_albedo * MiePhase(0.75 * aerosol_asymmetry, cosine) * (1.0 - exp(-depth));
}
