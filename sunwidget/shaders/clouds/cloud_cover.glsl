// Opacity of the photo's clouds anywhere in the picture, after the user's edits. With neutral
// parameters it is the photo's to the bit.

#include "clouds/cloud_opacity.glsl"
#include "clouds/cloud_layer.glsl"

// Outside the picture it is that at its edge. `place` as in frame/picture.glsl.
float GetOwnOpacity(sampler2D layers, vec2 place) {
  vec4 layer = ReadBilinear(layers, place);
  return EditOpacity(layer.g, layer.r, ReadBilinear(clear_sky, place).a);
}
