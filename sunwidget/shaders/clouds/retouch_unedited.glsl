// The photo itself, for pictures without cloud edits (cloud_parts.glsl).

#define CLOUDS_UNEDITED
#include "clouds/retouch.glsl"
