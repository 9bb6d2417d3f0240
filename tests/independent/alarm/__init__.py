"""A line with a track worker, a dispatcher and a server of the display, written from the paper (004) and the track."""
