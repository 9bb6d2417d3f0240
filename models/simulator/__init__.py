"""Traffic on a layout, played through the transitions of the abstract world: for walks, benches and replays."""
