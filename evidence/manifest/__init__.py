"""What binds the records to a commit: their hashes, and what of them can be made again."""
