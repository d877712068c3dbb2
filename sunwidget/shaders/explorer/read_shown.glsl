// The sky assembled by shown.glsl: one texture with the view by `model` on the left and the one
// by `compare` on the right, so that a pixel needs one look-up whatever is shown.

#include "atmosphere/read_sky_view.glsl"

uniform sampler2D shown;

const int kModelMultiple = 0;
const int kModelSingle = 1;
const int kModelBruneton = 2;
const int kModelReference = 3;

// `side` is 0 for the model, 1 for the one it is compared with; `view` is the same for both.
RadianceSpectrum GetShownRadiance(SkyView view, int side, vec3 direction) {
  ivec2 size = textureSize(shown, 0) / ivec2(2, 1);
  return GetSkyRadiance(shown, view, ivec2(side * size.x, 0), size, direction);
}
