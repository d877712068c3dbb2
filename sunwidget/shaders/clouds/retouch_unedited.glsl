// The photo itself, where no clouds are changed (cloud_parts.glsl).

#define CLOUDS_UNEDITED
#include "clouds/retouch.glsl"
