"""Proofs about the kernel: lifting, invariants, induction, witnesses."""
