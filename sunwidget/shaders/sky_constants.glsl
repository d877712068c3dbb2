// What all pixels of sky.glsl share.

#define PHOTOS_OWN_LIGHT
#include "lib/describe_sky.glsl"

void SetConstants() {
  SetDescribedSky();
}
