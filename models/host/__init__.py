"""What a host of the kernel brings along: the maps and sets that the centre's state is kept in."""
