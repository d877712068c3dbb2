// Light on surfaces and clouds, from the small table that light.glsl draws per sun
// (its texels: 0 sky on the ground, 1 sun, 2 sky on a surface that faces the camera).

vec3 GetLightTexel(sampler2D light, int index) {
  return max(SpectralToRec709(texelFetch(light, ivec2(index, 0), 0)), vec3(1e-9));
}

#include "land/soft_cosine.glsl"

// Irradiance of a landscape seen from the camera: the share `facing` of its surfaces is upright and
// faces the viewer, the rest is level. `visible` is the visible share of the sun's disc.
vec3 GetLandIrradiance(sampler2D light, float visible, float facing, vec3 sun_direction) {
  vec3 sky = mix(GetLightTexel(light, 0), GetLightTexel(light, 2), facing);
  float cosine = mix(GetSoftCosine(sun_direction.y, kRoughness), GetSoftCosine(-sun_direction.z, kRoughness), facing);
  return sky + visible * cosine * GetLightTexel(light, 1);
}

// Radiance of a white cloud, lit by the sky above and around it and, from any side, by the sun as
// seen at its height. `forward` adds the forward lobe of thin cloud (silver lining).
vec3 GetCloudRadiance(sampler2D light, float forward) {
  vec3 sky = 0.5 * (GetLightTexel(light, 0) + GetLightTexel(light, 2));
  return (sky + 0.5 * (1.0 + forward) * GetLightTexel(light, 8)) / 3.14159265;
}
