"""The world of the level crossing: trains that run towards it, and what ranging and tags say of them."""
