"""What a campaign can run: each target turns a batch's number into runs of the kernel, and says what they came to."""
