// Gloss of rough ground towards a low sun: grass, sand and roads reflect more grazing light forwards
// than Lambert's law predicts.

const float kGlossRoughness = 0.8;
const float kGlossAlbedo = 0.27;    // of the ground to which the gloss is added
const float kGlossReflectance = 0.04;
const float kHighestGloss = 0.342;  // sine of the sun's elevation (20 degrees)

float GetSmithShadowing(float cosine, float square) {
  return 2.0 * cosine / (cosine + sqrt(square + (1.0 - square) * cosine * cosine));
}

// BRDF times the sun's cosine of a GGX lobe (Walter et al. 2007, eqs. 20, 33, 34) on level ground, 1/sr,
// for a sun in direction `sun` and a viewer who looks along `view`. Above kHighestGloss it fades with
// the cosine of the elevation and no faster, so that ground never darkens under a rising sun.
float GetGroundLobe(vec3 view, vec3 sun, float roughness) {
  float square = roughness * roughness;
  float along = max(length(sun.xz), 1e-4);
  float rise = clamp(sun.y, 0.0, kHighestGloss);
  vec3 low = vec3(sun.xz / along * sqrt(1.0 - rise * rise), rise).xzy;
  float fade = min(along / sqrt(1.0 - kHighestGloss * kHighestGloss), 1.0);
  vec3 facet = normalize(low - view + vec3(0.0, 1e-3, 0.0));
  float n_view = max(-view.y, 0.02);
  float tilt = facet.y * facet.y * (square - 1.0) + 1.0;
  float facets = square / (3.14159265 * tilt * tilt);
  float away = 1.0 - clamp(dot(low, facet), 0.0, 1.0);
  float fresnel = kGlossReflectance + (1.0 - kGlossReflectance) * away * away * away * away * away;
  float shadowing = GetSmithShadowing(n_view, square) * GetSmithShadowing(low.y, square);
  return fade * facets * fresnel * shadowing / (4.0 * n_view);
}

// The gloss to add to the cosine of the sun, in units of diffuse light.
float GetGloss(vec3 view, vec3 sun) {
  return 3.14159265 / kGlossAlbedo * GetGroundLobe(view, sun, kGlossRoughness);
}
