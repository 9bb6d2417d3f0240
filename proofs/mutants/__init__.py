"""How strong the guards, the updates and the assumptions are: each is dropped, and somebody must notice."""
