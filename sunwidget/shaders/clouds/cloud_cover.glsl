// How opaque the clouds are, anywhere in the picture, after the person's changes. With neutral
// parameters it is the photo's opacity to the bit.

#include "clouds/cloud_opacity.glsl"
#include "clouds/cloud_layer.glsl"

// The photo's own clouds; outside the picture those of its edge. `place` as in frame/picture.glsl.
float GetOwnOpacity(sampler2D layers, vec2 place) {
  vec4 layer = ReadBilinear(layers, place);
  return EditOpacity(layer.g, layer.r, ReadBilinear(clear_sky, place).a);
}

// They and the added clouds.
float GetCloudOpacity(sampler2D layers, vec2 place) {
  float own = GetOwnOpacity(layers, place);
  float added = GetAddedCover(GetViewDirection(place));
  return own + (ReadBilinear(layers, place).r - own) * added;
}
