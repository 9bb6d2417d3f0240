"""What stands in the folder of records, and what each piece of evidence comes to by it."""
