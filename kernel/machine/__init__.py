"""Centre, unit and point terminal, each as one machine: what it is told, what it makes of it, and what it says."""
