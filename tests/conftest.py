"""What all tests share."""

from hypothesis import settings

settings.register_profile("mind", deadline=None)  # a shared machine takes its time
settings.load_profile("mind")
