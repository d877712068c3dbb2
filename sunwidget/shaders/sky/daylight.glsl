// Light on surfaces and clouds, from the small table that light.glsl draws per sun
// (its texels: 0 sky on the ground, 1 sun, 2 sky on a surface that faces the camera).

vec3 GetLightTexel(sampler2D light, int index) {
  return max(SpectralToRec709(texelFetch(light, ivec2(index, 0), 0)), vec3(1e-9));
}

// The texels that surfaces and clouds need: the sky's light on level land and on what faces the camera, the sun's, and
// the sun's at the height of clouds.
struct Daylight {
  vec3 up;
  vec3 facing;
  vec3 sun;
  vec3 high_sun;
};

Daylight ReadDaylight(sampler2D light) {
  return Daylight(GetLightTexel(light, 0), GetLightTexel(light, 2), GetLightTexel(light, 1), GetLightTexel(light, 8));
}

#include "land/soft_cosine.glsl"

// Irradiance of a landscape seen from the camera: the share `facing` of its surfaces is upright and
// faces the viewer, the rest is level. `visible` is the visible share of the sun's disc.
vec3 GetLandIrradiance(Daylight light, float visible, float facing, vec3 sun_direction) {
  vec3 sky = mix(light.up, light.facing, facing);
  float cosine = mix(GetSoftCosine(sun_direction.y, kRoughness), GetSoftCosine(-sun_direction.z, kRoughness), facing);
  return sky + visible * cosine * light.sun;
}

// Radiance of a white cloud, lit by the sky above and around it and, from any side, by the sun as
// seen at its height. `forward` adds the forward lobe of thin cloud (silver lining).
vec3 GetCloudRadiance(Daylight light, float forward) {
  return (0.5 * (light.up + light.facing) + 0.5 * (1.0 + forward) * light.high_sun) / 3.14159265;
}
