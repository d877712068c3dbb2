// The picture's light source: the sun or a full moon, whose light the air scatters in the same way.
// Only method "ratio" exchanges them; passes of the other methods define PHOTOS_OWN_LIGHT.

uniform int light_source;   // 0 sun, 1 moon, 2 as in the photo
uniform float photo_light;  // the photo's own: 0 sun, 1 moon

// Full moon over sun, each at its mean distance: 14.01 magnitudes, and redder, B-V 0.92 against
// 0.65 (Krisciunas & Schaefer 1991, "A model of the brightness of moonlight", PASP 103; Allen 1973).
const vec3 kMoonOverSun = vec3(1.1, 1.0, 0.8) / 402000.0;
// Airglow and stars, 21.6 magnitudes per square arc second, in kcd m^-2: what remains when the moon
// has set.
const vec3 kNightSky = vec3(2.6e-7, 2.5e-7, 2.3e-7);

// 1 when the moon lights this state's picture, 0 when the sun does.
float GetMoon() {
#ifdef PHOTOS_OWN_LIGHT
  return photo_light;
#else
  return light_source == 2 ? photo_light : float(light_source);
#endif
}

// 1 when a sun lights the photo and this state's picture, 0 when either has a moon.
float GetSunToSun() {
  return (1.0 - photo_light) * (1.0 - GetMoon());
}

// The model is lit by the sun and matched to the photo (sky_gain), whichever source lit the photo. This
// factor converts it to the source of this state; it is exactly one if that is the photo's own.
vec3 GetLightScale(float moon) {
  return mix(vec3(1.0), kMoonOverSun, moon) / mix(vec3(1.0), kMoonOverSun, photo_light);
}

// Radiance that does not come from the moon.
vec3 GetNightSky(float moon) {
  return moon * kNightSky / mix(vec3(1.0), kMoonOverSun, photo_light);
}
