// The frame for pixels of sky alone (frame_parts.glsl).

#define SKY_ALONE
#include "frame/frame.glsl"
