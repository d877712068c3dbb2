uniform vec2 frame_size;  // the whole picture, pixels
