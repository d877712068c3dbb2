// Light shafts: land or clouds before the sun leave the haze behind them unlit. The picture itself
// shows these obstacles: its openness is sampled from each pixel towards the sun's place
// (Mitchell 2007, "Volumetric light scattering as a post-process", GPU Gems 3, ch. 13).

#include "frame/picture.glsl"
#include "atmosphere/read_sky_view.glsl"

uniform sampler2D openness;
uniform float sun_azimuth;
uniform float sun_elevation;

const int kShaftSteps = 24;
// Longest sampled path, in heights of the picture: farther away, the openings that the sun shines
// through are as wide as a beam.
const float kLongestShaft = 1.2;
// The rings of shaft_rings.glsl reach this far from the sun, in heights of the picture.
const float kLargestRing = 3.2;

float GetAspect() {
  return frame_size.x / frame_size.y;
}

// The sun's place in fractions of the picture; z is how far it lies before the camera, 0 to 1. Beams
// from outside the picture are nearly parallel, so a sun farther out is clamped to these bounds.
vec3 GetShaftSun() {
  vec3 at = GetPlaceOfDirection(GetSunDirection(sun_azimuth, sun_elevation));
  return vec3(clamp(at.xy, vec2(-1.0), vec2(2.0)), smoothstep(0.0, 0.3, at.z));
}

// x: mean openness from `place` towards `sun` (fractions of the picture), weighted towards the pixel;
// y: the share of the path that lies above the horizon and so carries information.
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

// Radiance of ten kilometres of this haze at `cosine` from the sun, per unit of the sun's irradiance;
// clear air has almost none. Far along a beam light is scattered twice, which widens the lobe.
float GetHazeLight(float cosine) {
  const float kPath = 10000.0;  // m
  float depth = kPath * aerosol_optical_depth / aerosol_scale_height;
  return aerosol_albedo * MiePhase(0.75 * aerosol_asymmetry, cosine) * (1.0 - exp(-depth));
}
