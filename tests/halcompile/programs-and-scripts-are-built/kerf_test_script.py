print("python program")
