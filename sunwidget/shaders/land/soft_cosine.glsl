// Ground is rough: grains, blades and waves catch a low sun that a plane would lose, so the cosine
// runs out softly (half of the roughness at grazing light) instead of at zero.

const float kRoughness = 0.45;

float GetSoftCosine(float cosine, float roughness) {
  return 0.5 * (cosine + sqrt(cosine * cosine + roughness * roughness));
}
