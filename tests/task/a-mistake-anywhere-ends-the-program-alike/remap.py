def raises(self, **words):
    raise ValueError("the remap can not")
