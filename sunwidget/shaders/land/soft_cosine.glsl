// Ground is rough: grains, blades and waves catch a low sun that a plane would miss. The cosine therefore
// fades softly (half of the roughness at grazing light) instead of ending at zero.

const float kRoughness = 0.45;

float GetSoftCosine(float cosine, float roughness) {
  return 0.5 * (cosine + sqrt(cosine * cosine + roughness * roughness));
}
