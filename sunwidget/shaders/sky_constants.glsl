// What all pixels of sky.glsl share.

#include "lib/describe_sky.glsl"

void SetConstants() {
  SetDescribedSky();
}
