// The first texels of composite_constants.glsl, by way of frame_constants.glsl; what few pixels need is read from the map itself.

flat in vec4 term[11];
uniform sampler2D terms;
