"""One top on the three planes: rough, smooth, and with sliding friction."""
