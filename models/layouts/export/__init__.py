"""What is handed over of a layout: its plan of tags, its tables for review, and itself in other formats."""
