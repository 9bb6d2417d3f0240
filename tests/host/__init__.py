"""What a host brings along."""
