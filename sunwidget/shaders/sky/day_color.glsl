// The color of a blue sky as the sun sinks by day, relative to the model's. Around suns of any height photos show
// blue skies that turn white, for cameras balance white; the model's air turns beige. Measured on photos by
// training/skies/high_sun.py. Low suns keep their warmth, gray and violet skies the model's colors, and so does a sky
// whose sun rises.

#include "sky/moonlight.glsl"

uniform float sun_elevation;  // degrees, apparent
uniform float source_sun_elevation;
uniform vec3 photo_sky_linear_mean;

const vec2 kDay = vec2(5.0, 11.0);  // degrees
// 0.7 of the color of sunlight, log2 per air mass at constant luminance, in clear air (Rayleigh, aerosol of depth 0.1).
const vec3 kSunColor = vec3(0.07, 0.0, -0.175);
// Mean color of the photo's sky: log2 of blue over red, and of green over both, of gray or violet skies and of blue ones.
const vec2 kBlue = vec2(0.8, 1.8);
const vec2 kViolet = vec2(-0.3, -0.1);

float GetAirMass(float elevation) {
  return 1.0 / (sin(radians(max(elevation, kDay.x))) + 0.03);
}

vec3 GetDayColor() {
#ifdef PHOTOS_OWN_LIGHT
  return vec3(1.0);
#else
  vec3 sky = log2(max(photo_sky_linear_mean, vec3(1e-4)));
  float day = smoothstep(kBlue.x, kBlue.y, sky.b - sky.r)
      * smoothstep(kViolet.x, kViolet.y, sky.g - 0.5 * (sky.r + sky.b))
      * smoothstep(kDay.x, kDay.y, sun_elevation) * (1.0 - photo_light) * (1.0 - GetMoon());
  float gained = max(GetAirMass(sun_elevation) - GetAirMass(source_sun_elevation), 0.0);
  return exp2(-day * gained * kSunColor);
#endif
}
